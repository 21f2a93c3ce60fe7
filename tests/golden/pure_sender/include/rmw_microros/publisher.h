#error "The component 'publish_statistics' is not selected: add `components: [+publish_statistics]` to microros.yaml and generate again"
