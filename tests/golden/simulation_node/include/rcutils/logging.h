#error "The component 'logging' is not selected: add `components: [+logging]` to microros.yaml and generate again"
