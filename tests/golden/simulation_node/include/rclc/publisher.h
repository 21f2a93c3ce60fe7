#error "The component 'publish' is not selected: add `components: [+publish]` to microros.yaml and generate again"
